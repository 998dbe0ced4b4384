// The decompositions of dense matrices by Eigen, compiled once: a source that includes this header
// in place of Eigen/Cholesky, Eigen/LU, ... does not compile them again, which takes 1 to 5 s each.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// The declarations below fit only if the argument is an Eigen::MatrixXd: a product or a sum must be
// stored in a matrix before it is decomposed. They are only the members that take time to compile,
// because whole classes would have members that nobody calls. Each must have its definition in
// decompositions.cpp. Doxygen does not understand them.
/// @cond
extern template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::computeInPlace();
extern template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::computeInPlace();
extern template void Eigen::HouseholderQR<Eigen::MatrixXd>::computeInPlace();
extern template void Eigen::PartialPivLU<Eigen::MatrixXd>::compute();
extern template Eigen::JacobiSVD<Eigen::MatrixXd>& Eigen::JacobiSVD<Eigen::MatrixXd>::compute(
    const Eigen::MatrixXd&, unsigned int);
extern template Eigen::LDLT<Eigen::MatrixXd>& Eigen::LDLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
extern template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&,
                                                        int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::computeFromTridiagonal(const Eigen::VectorXd&,
                                                                       const Eigen::VectorXd&, int);

// solve() calls these members, which are public, with the right-hand side and the solution.
extern template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(
    const Eigen::MatrixXd&, Eigen::MatrixXd&) const;
extern template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(
    const Eigen::VectorXd&, Eigen::VectorXd&) const;
extern template void Eigen::HouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                        Eigen::MatrixXd&) const;
extern template void Eigen::LDLT<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                               Eigen::VectorXd&) const;
extern template void Eigen::LLT<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                              Eigen::VectorXd&) const;
/// @endcond

namespace viscontact {

/// The first columns of Q in the decomposition Q R of a matrix, as many as the matrix has.
Eigen::MatrixXd first_columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr);
/// The whole orthogonal matrix Q in the decomposition Q R.
Eigen::MatrixXd whole_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr);
/// Q v, for the whole orthogonal matrix Q in the decomposition Q R.
Eigen::VectorXd q_times(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr, const Eigen::VectorXd& v);
/// Q^T v, for the whole orthogonal matrix Q in the decomposition Q R.
Eigen::VectorXd transposed_q_times(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr,
                                   const Eigen::VectorXd& v);

}  // namespace viscontact
