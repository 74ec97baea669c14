//VTK::System::Dec
//VTK::Output::Dec
void main()
{
}
