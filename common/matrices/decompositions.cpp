// The definitions for decompositions.hpp.
#include "viscontact/common/matrices/decompositions.hpp"

template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::computeInPlace();
template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::computeInPlace();
template void Eigen::HouseholderQR<Eigen::MatrixXd>::computeInPlace();
template void Eigen::PartialPivLU<Eigen::MatrixXd>::compute();
template Eigen::JacobiSVD<Eigen::MatrixXd>& Eigen::JacobiSVD<Eigen::MatrixXd>::compute(
    const Eigen::MatrixXd&, unsigned int);
template Eigen::LDLT<Eigen::MatrixXd>& Eigen::LDLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&,
                                                        int);
template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::computeFromTridiagonal(const Eigen::VectorXd&,
                                                                       const Eigen::VectorXd&, int);

template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(
    const Eigen::MatrixXd&, Eigen::MatrixXd&) const;
template void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(
    const Eigen::VectorXd&, Eigen::VectorXd&) const;
template void Eigen::HouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,
                                                                 Eigen::MatrixXd&) const;
template void Eigen::LDLT<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                        Eigen::VectorXd&) const;
template void Eigen::LLT<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,
                                                       Eigen::VectorXd&) const;

namespace viscontact {

Eigen::MatrixXd first_columns_of_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), qr.cols());
}

Eigen::MatrixXd whole_q(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr) {
  return qr.householderQ();
}

Eigen::VectorXd q_times(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr, const Eigen::VectorXd& v) {
  return qr.householderQ() * v;
}

Eigen::VectorXd transposed_q_times(const Eigen::HouseholderQR<Eigen::MatrixXd>& qr,
                                   const Eigen::VectorXd& v) {
  return qr.householderQ().adjoint() * v;
}

}  // namespace viscontact
